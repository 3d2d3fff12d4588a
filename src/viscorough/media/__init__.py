"""Linear viscoelastic media, and loads: forces or depths of an indenter as functions of time."""
