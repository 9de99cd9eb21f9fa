"""Tools for developers of this checkout; not part of the product.

- ``setup`` creates and checks the environment: packages, a browser for tests, the oldest versions, test runs.
- ``demo`` demonstrates the workspace, on the arm alone and on an emulated bench.
- ``ros2`` replaces the command ``ros2``.
- ``benchmarks`` measure, and keep one record each (``record.py``), from which ``report.py`` generates
  docs/benchmarks.md.
- ``docs`` generates pages and pictures from sources without measurements.

``one_line.py`` ends their commands with a one-line message if they cannot continue.
"""
