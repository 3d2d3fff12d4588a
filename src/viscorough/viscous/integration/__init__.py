"""Direct integration of viscoelastic contact in time, without the correspondence with the elastic problem."""
