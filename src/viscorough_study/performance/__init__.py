"""What every method costs, and how accurate it is."""
