"""The controllers, one module a family."""
