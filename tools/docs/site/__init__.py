"""The pages for readers as one site: tutorials, how-to guides, reference and explanation (Procida's four kinds)."""
