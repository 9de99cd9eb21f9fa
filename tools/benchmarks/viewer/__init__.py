"""What the viewer costs, and what it costs others."""
