"""The elastic half-space under uniform pressure on rectangular elements: influence coefficients, their operator."""
