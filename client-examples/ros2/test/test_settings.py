import re
from dataclasses import fields
from pathlib import Path

from singulate_ros.settings import Settings


def test_the_example_names_every_parameter() -> None:
    lines = Path(__file__).parent.with_name("example.yaml").read_text().splitlines()
    named = [found[1] for line in lines if (found := re.match(r" {4}(\w+): \S", line))]
    assert named == [field.name for field in fields(Settings)]
