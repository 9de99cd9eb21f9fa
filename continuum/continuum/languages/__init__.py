"""What people read, in their language; files for machines, keys and names of effects are English in all of them.

Sentences stand in the code in English, as arguments of a `Translator` (`tr("Open-loop error")`) or of a `Message`. A
catalogue ``pt.po`` has their translations; ``make languages`` collects new sentences and compiles it to ``pt.mo``.

Public: `LANGUAGES`, `Message`, `Translator`, `translator`.
"""

from continuum.languages.message import Message
from continuum.languages.translator import ENGLISH, LANGUAGES, Translator, translator

__all__ = ["ENGLISH", "LANGUAGES", "Message", "Translator", "translator"]
