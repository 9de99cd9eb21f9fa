"""The set-up behind `make setup`. Runs on a bare Python 3.12: standard library only."""
