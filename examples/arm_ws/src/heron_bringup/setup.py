from pathlib import Path

from setuptools import setup

package_name = "heron_bringup"
launches = [str(file) for file in Path("launch").glob("*.launch.py")]
worlds = [str(file) for file in Path("worlds").glob("*.world")]

setup(
    name=package_name,
    version="0.1.0",
    packages=[package_name],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/launch", launches),
        ("share/" + package_name + "/worlds", worlds),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="The Gazelle developers",
    maintainer_email="developers@gazelle.invalid",
    description="The heron arm at its workbench, and a program that moves a cube there.",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "pick_and_place = heron_bringup.pick_and_place:main",
        ],
    },
)
