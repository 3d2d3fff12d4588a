"""Linear viscoelastic media, and the histories of force or depth that act on them."""
