// Neither.
