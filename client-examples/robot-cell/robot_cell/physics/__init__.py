"""The world, the hands, what carries them, and the judge."""
