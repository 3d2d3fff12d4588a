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
        model.operators[name] = _Operator(model.E / (1 - model.nu**2), model.side)


class _Operator:
    def __init__(self, modulus, side):
        self.modulus, self.side = modulus, side

    def __call__(self, pressure, displacement):
        displacement[...] = dense_contact.displacement(pressure, self.modulus, self.side)


class PolonskyKeerRey:
    """`surface` are heights that point into the half-space, `tolerance` a share of their range."""

    def __init__(self, model, surface, tolerance):
        self.model, self.surface, self.tolerance = model, surface, tolerance

    def setIntegralOperator(self, name):
        self.operator = self.model.operators[name]

    def solve(self, mean_pressure):
        assert (self.model.traction >= 0).all()
        assert self.model.traction.any()
        gap, constants = self.surface.max() - self.surface, (self.operator.modulus, self.operator.side)
        force = mean_pressure * gap.size * self.operator.side**2
        pressure = dense_contact.pressure_at_force(gap, force, *constants)
        length = self.tolerance * np.ptp(self.surface)
        self.model.traction[...] = dense_contact.disturbed(pressure, length, *constants)
        return self.tolerance
