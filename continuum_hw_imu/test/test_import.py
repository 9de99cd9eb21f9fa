"""The package is there and says what it will be."""

import continuum_hw_imu


def test_package_is_installed_with_its_description() -> None:
    assert "inertial sensors" in (continuum_hw_imu.__doc__ or "")
