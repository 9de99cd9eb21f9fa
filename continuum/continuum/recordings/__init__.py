"""Reading what the workspace recorded, and what a recording says of the arm's kinematics."""
