"""Direct integration in time: contacts that follow the motion of the medium, without the correspondence."""
