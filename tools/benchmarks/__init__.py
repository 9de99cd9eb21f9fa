"""What is measured: each benchmark or campaign is a package whose main keeps one record and re-makes its pages."""
