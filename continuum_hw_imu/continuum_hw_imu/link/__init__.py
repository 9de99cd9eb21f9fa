"""The host's end of the link: a serial port that may disappear and return, and the client of the bench controller."""
