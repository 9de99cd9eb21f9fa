"""Exams of the whole way that a stranger goes, from files to a verdict; each gives a section of a page."""
