"""The arm in a browser: a page that shows what nodes, a recording or its own sliders say (viser, URDF by yourdfpy)."""
