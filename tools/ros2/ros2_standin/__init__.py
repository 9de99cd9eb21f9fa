"""A small stand-in for the ``ros2`` command, for machines where no stock ``ros2`` is installed.

It is not part of the product: the workspace's nodes, launch files and recordings are those of stock ROS 2, and a stock
``ros2`` on the PATH has precedence.
"""
