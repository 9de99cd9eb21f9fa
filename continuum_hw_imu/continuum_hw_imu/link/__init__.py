"""The host's end of the link: a serial port that comes and goes, and the client of the bench controller behind it."""
