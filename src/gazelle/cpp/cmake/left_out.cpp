// Stands in for the sources of a target that is left out.
__attribute__((weak)) int main() { return 1; }
