"""How the numbers of the report come about, and how far to trust them."""
