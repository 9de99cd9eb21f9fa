"""What the tests of the library measure it against: differences, chains of rigid links, samples and drawn arms."""
