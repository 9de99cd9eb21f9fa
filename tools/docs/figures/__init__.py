"""`make figures`: the pictures of README.md that no other command generates."""
