"""Cost and accuracy of every method."""
