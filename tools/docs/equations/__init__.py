"""`make equations`: where each equation, table and figure of the thesis is in this workspace, and what tests it."""
