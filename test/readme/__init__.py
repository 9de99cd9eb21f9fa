"""The command blocks of README.md: read off the page, and run as a person would."""
