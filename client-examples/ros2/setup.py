from setuptools import setup

PACKAGE = "singulate_ros"

setup(
    name=PACKAGE,
    version="0.1.0",
    description="Asks singulate which objects to move first, from what a camera and MoveIt say about a table",
    maintainer="the maintainers of singulate",
    maintainer_email="maintainer@example.com",
    license="MIT",
    python_requires=">=3.10",
    packages=[PACKAGE],
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml", "example.yaml"]),
    ],
    install_requires=["setuptools"],
    extras_require={"test": ["pytest"]},
    zip_safe=True,
    entry_points={"console_scripts": [f"plan = {PACKAGE}.node:main"]},
)
