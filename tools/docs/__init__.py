"""What makes documentation that no benchmark makes: API reference, table of equations, pictures, notebook outputs."""
