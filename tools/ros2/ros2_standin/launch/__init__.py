"""Launch files, in small part: read, evaluated, and run; the stock launch runs them alike."""
