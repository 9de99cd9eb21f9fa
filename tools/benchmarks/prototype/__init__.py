"""What the diagnosis says of the prototype itself, by the one run of it that was published."""
