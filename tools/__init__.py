"""What people who work on this checkout run: set-up, demonstration, stand-in for `ros2`. No part of the product."""
