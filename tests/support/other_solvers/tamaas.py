"""Stand-in for Tamaas: the part of its interface that the adapter uses, solved exactly by a dense matrix."""

from types import SimpleNamespace

import dense_contact
import numpy as np

LogLevel = SimpleNamespace(error=3)
model_type = SimpleNamespace(basic_2d="basic_2d")


def set_log_level(level):
    assert level == LogLevel.error


def initialize(threads):
    assert threads == 1


class Model:
    def __init__(self, kind, system_size, discretization):
        assert kind == model_type.basic_2d
        self.side = system_size[0] / discretization[0]
        self.traction, self.operators = np.zeros(discretization), {}
        self.E, self.nu = 1.0, 0.0


class ModelFactory:
    @staticmethod
    def registerNonPeriodic(model, name):
        """An operator keeps the elastic constants that the model has now."""
        model.operators[name] = model.E / (1 - model.nu**2), model.side


class PolonskyKeerRey:
    """`surface` are heights that point into the half-space, `tolerance` a share of their range."""

    def __init__(self, model, surface, tolerance):
        self.model, self.surface, self.tolerance = model, surface, tolerance

    def setIntegralOperator(self, name):
        self.constants = self.model.operators[name]

    def solve(self, mean_pressure):
        assert (self.model.traction >= 0).all()
        assert self.model.traction.any()
        gap = self.surface.max() - self.surface
        force = mean_pressure * gap.size * self.model.side**2
        pressure = dense_contact.pressure_at_force(gap, force, *self.constants)
        length = self.tolerance * np.ptp(self.surface)
        self.model.traction[...] = dense_contact.disturbed(pressure, length, *self.constants)
        return self.tolerance
