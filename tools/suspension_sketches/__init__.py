"""Sketches of suspensions as SVG: hardpoints, parts in space, their views, labels, pages."""
