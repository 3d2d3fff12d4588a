"""Names of media, as figures and the page write them."""


def medium_label(name):
    """Name of a medium of the settings as text: "Standard linear solid"."""
    return name.replace("_", " ").capitalize().replace("Kelvin voigt", "Kelvin-Voigt")
