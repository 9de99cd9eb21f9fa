"""XML launch files: read, evaluated, and run; the same files run under the stock launch."""
