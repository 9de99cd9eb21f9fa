"""A choice between words on the page; any other word from a browser has no effect."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from continuum.viewer.layout import Layout


class Choice:
    """A dropdown in the container of the page that is open at its creation.

    Args:
        layout: page.
        label: label on the page.
        options: words to choose from.
        first: initial choice; the first option by default.
        properties: further properties of the dropdown of viser.
    """

    def __init__(
        self, layout: Layout, label: str, options: Sequence[str], first: str | None = None, **properties: Any
    ) -> None:
        self._label = label
        self._options = tuple(options)
        self._chosen = self._options[0] if first is None else first
        self._faults = layout.faults
        self._handle = layout.server.gui.add_dropdown(label, self._options, initial_value=self._chosen, **properties)
        self.on_update = self._handle.on_update
        layout.words.update(self._options)

    @property
    def value(self) -> str:
        """The choice, one of the options."""
        said = self._handle.value
        if said in self._options:
            self._chosen = said
        else:
            self._faults.note("choice of a browser", f"{self._label}: {said!r}; allowed: {', '.join(self._options)}")
            self._handle.value = self._chosen  # type: ignore[misc]
        return self._chosen

    @value.setter
    def value(self, option: str) -> None:
        self._handle.value = option  # type: ignore[misc]
