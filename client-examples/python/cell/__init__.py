"""A cell controller that asks singulate what to move first."""
