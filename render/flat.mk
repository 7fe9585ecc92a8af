# The reference renderer will live here (README.md).
