# Sourced by .venv/local_setup.*, hence by `source install/setup.bash`: makes the virtual environment the ROS
# installation under the workspace. POSIX shell; safe to source again and under `set -u`.
# In: _continuum_root, _continuum_base_python.

_continuum_prepend() { # name of a list variable, folder: put the folder first, once
    eval "_continuum_list=\":\${$1:-}:\""
    while [ "$_continuum_list" != "${_continuum_list#*":$2:"}" ]; do
        _continuum_list="${_continuum_list%%":$2:"*}:${_continuum_list#*":$2:"}"
    done
    _continuum_list="${_continuum_list#:}"
    _continuum_list="${_continuum_list%:}"
    eval "export $1=\"\$2\${_continuum_list:+:\$_continuum_list}\""
    unset _continuum_list
}

_continuum_prepend PATH "$_continuum_root/.venv/bin"
_continuum_prepend AMENT_PREFIX_PATH "$_continuum_root/.venv"
_continuum_prepend CMAKE_PREFIX_PATH "$_continuum_root/.venv"
unset -f _continuum_prepend

# Left by another Python: the first misleads any interpreter, the second keeps the ROS wheels from finding their libraries.
unset PYTHONHOME _ROS_WHEELS_BOOTSTRAP_COMPLETE

export ROS_VERSION=2 ROS_PYTHON_VERSION=3 ROS_DISTRO=jazzy
export RMW_IMPLEMENTATION="${RMW_IMPLEMENTATION:-rmw_fastrtps_cpp}"
export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"
export FASTRTPS_DEFAULT_PROFILES_FILE="${FASTRTPS_DEFAULT_PROFILES_FILE:-$_continuum_root/continuum_manipulator/config/fastdds.xml}"

# colcon's shell files call their interpreter unquoted; this one has no space in its path.
export COLCON_PYTHON_EXECUTABLE="${COLCON_PYTHON_EXECUTABLE:-$_continuum_base_python}"

unset _continuum_root _continuum_base_python
