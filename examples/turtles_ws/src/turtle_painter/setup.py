from glob import glob

from setuptools import find_packages, setup

package_name = "turtle_painter"

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/launch", glob("launch/*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="The Gazelle developers",
    maintainer_email="developers@gazelle.invalid",
    description="Turtles that draw flowers.",
    license="Apache-2.0",
    entry_points={
        "console_scripts": ["paint = turtle_painter.paint:main"],
    },
)
