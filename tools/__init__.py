"""What people who work on this checkout run; no part of the product.

- ``setup`` makes and checks the environment: packages, a browser for tests, the oldest versions, the runs of the tests;
- ``demo`` shows the workspace at work, on the arm alone and on an emulated bench;
- ``ros2`` stands in for the command ``ros2``;
- ``benchmarks`` measure, and keep one record each (``record.py``), of which ``report.py`` makes docs/benchmarks.md;
- ``docs`` makes pages and pictures from sources and measures nothing, so that it belongs to none of the other four.

``one_line.py`` ends their commands with one line where they cannot go on.
"""
