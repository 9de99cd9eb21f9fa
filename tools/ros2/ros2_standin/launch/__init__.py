"""Launch files, in XML and in small part in Python: read, evaluated, and run; the stock launch runs them alike."""
