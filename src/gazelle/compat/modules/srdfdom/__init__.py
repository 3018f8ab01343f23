"""srdfdom, by Gazelle."""
