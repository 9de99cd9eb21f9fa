"""Exams of the complete workflow of a new user, from files to a verdict; each one gives a section of a page."""
