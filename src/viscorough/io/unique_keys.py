"""Load YAML, and refuse a mapping with a repeated key; the yaml library would keep the last value of the key."""

from typing import Any

import yaml


class UniqueKeys(yaml.SafeLoader):
    """Loader for yaml.load that raises a MarkedYAMLError at the second of two equal keys."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if isinstance(key, yaml.ScalarNode) and key.value in seen:
                raise yaml.MarkedYAMLError(problem=f"key {key.value} for the second time", problem_mark=key.start_mark)
            seen.add(str(key.value))
        return super().construct_mapping(node, deep)
