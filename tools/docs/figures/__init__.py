"""`make figures`: the pictures of README.md that no page's own command makes."""
