"""Compiling C++ of packages on this machine: compilers, CMake, runtime libraries, what is kept."""
