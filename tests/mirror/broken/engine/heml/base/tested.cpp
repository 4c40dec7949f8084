// Has its test.
