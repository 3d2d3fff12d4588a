"""Where methods fail, and whether users are told."""
