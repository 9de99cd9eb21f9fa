"""Catalogues of translations: collected from the code, compiled for it."""
