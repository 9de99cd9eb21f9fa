"""A diagnosis as one self-contained page."""

from continuum.discovery.report.page import write_report

__all__ = ["write_report"]
