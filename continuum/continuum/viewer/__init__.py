"""The arm in a browser: a page that shows states from nodes, a recording or its sliders (viser; yourdfpy for URDF)."""
