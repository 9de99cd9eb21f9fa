"""Blind tests: data from an independent plant with a hidden effect, and analyses that are handed files only."""
