"""Joint angles from inertial sensors on the links (thesis section 3.3): gyroscopes, accelerometers, no magnetometer."""
