"""The paper's method against others: MDR, direct integration, other media, measured surfaces, literature."""
