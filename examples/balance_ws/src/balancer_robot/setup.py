from glob import glob

from setuptools import find_packages, setup

package_name = "balancer_robot"

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/config", glob("config/*")),
        ("share/" + package_name + "/launch", glob("launch/*")),
        ("share/" + package_name + "/urdf", glob("urdf/*")),
        ("share/" + package_name + "/worlds", glob("worlds/*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="The Gazelle developers",
    maintainer_email="developers@gazelle.invalid",
    description="A robot on two wheels that stays up by a controller of its own.",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "balance = balancer_robot.balance:main",
            "push = balancer_robot.push:main",
        ],
    },
)
