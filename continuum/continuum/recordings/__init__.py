"""Recordings of an arm's runs: reading, checking and writing them, and what they show of the kinematics.

=====================  ===================================================================================
recording.py           what was measured in one run; `read_recording.py` by `recording_csv.py`, `recording_bag.py`
recording_checks.py    faults of its `samples.py`: `plausible_values.py`, `burst_stamps.py`, `whole_turns.py`
csv_layout.py          faults of a table
cable_sides.py         whether the arm bends towards the cable that pulls more
motion_columns.py      names of columns; `motion_table.py`, `input_table.py`, `cable_table.py`: tables
bag.py                 rosbag2 without ROS; `named_values.py`: values of a message by name
arm_recording.py       messages of the arm's kinematics; `kinematic_report.py` shows whether they are consistent
=====================  ===================================================================================

Public: `recording.Recording`, `read_recording.read_recording`, `recording_csv.read_recording_csv`,
`recording_bag.read_recording_bag`, `bag.Bag`, `arm_recording.read_arm_recording`, `kinematic_report.report_on`,
`motion_table.write_motion_table`, `motion_figure.write_motion_figure`.
"""
