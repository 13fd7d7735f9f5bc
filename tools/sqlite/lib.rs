// Empty: the crate exists to fetch its dependency.
