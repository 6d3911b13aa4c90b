"""A robot cell in physics: carries out the plans of singulate and judges each contact."""
