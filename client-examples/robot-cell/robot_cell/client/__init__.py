"""Asks the service, and decides what the cell does next."""
