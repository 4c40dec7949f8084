// In the README.
