"""Recordings: what was measured in a run of an arm, read, checked and written; and what it says of the kinematics.

=====================  ===================================================================================
recording.py           what was measured in one run; `read_recording.py` by `recording_csv.py`, `recording_bag.py`
recording_checks.py    what may be wrong with its `samples.py`, `plausible_values.py`; `csv_layout.py`: with a table
cable_sides.py         whether the arm bends towards the cable that pulls more
motion_columns.py      names of columns; `motion_table.py`, `input_table.py`, `cable_table.py`: tables
bag.py                 rosbag2 without ROS; `named_values.py`: values of a message by name
arm_recording.py       the arm's kinematic chain of messages; `kinematic_report.py` says whether it holds
=====================  ===================================================================================
"""
