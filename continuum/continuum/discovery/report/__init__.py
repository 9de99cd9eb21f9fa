"""A diagnosis as one page that needs no other file."""

from continuum.discovery.report.page import write_report

__all__ = ["write_report"]
