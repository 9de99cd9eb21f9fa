"""Equations that several effects need."""
