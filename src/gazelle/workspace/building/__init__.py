"""What building a package installs, and a workspace built without compilers."""
