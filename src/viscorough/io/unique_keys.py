"""YAML in which no key stands twice."""

import yaml


class UniqueKeys(yaml.SafeLoader):
    """YAML with a fault where a key stands twice in a mapping; its readers would keep the last."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if isinstance(key, yaml.ScalarNode) and key.value in seen:
                raise yaml.MarkedYAMLError(problem=f"key {key.value} for the second time", problem_mark=key.start_mark)
            seen.add(str(key.value))
        return super().construct_mapping(node, deep)
