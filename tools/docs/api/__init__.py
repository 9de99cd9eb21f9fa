"""`make api`: the library's reference from its docstrings, and a check of its links."""
