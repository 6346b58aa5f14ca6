"""The stubs say what the module has: every class, function, property and parameter, in its order and
with its default."""

import ast
import pathlib
import unittest

import nbvopt._core
import nbvopt._sim

FOLDER = pathlib.Path(nbvopt.__file__).parent
# What an object of Python has anyway, and what pybind11 adds.
COMMON = {"__init__", "__doc__", "__module__", "__repr__", "__hash__", "__eq__"}


def parameters(function: ast.FunctionDef) -> list:
    """Name, kind and default of each; what a stub leaves open is ...."""
    arguments = function.args
    missing = [None] * (len(arguments.args) - len(arguments.defaults))
    result = [
        (argument.arg, "positional", default and ast.unparse(default))
        for argument, default in zip(arguments.args, missing + arguments.defaults)
    ]
    result += [
        (argument.arg, "keyword", default and ast.unparse(default))
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)
    ]
    return result


def built(function) -> ast.FunctionDef:
    """What the first line of pybind11's docstring says."""
    return ast.parse(f"def {function.__doc__.splitlines()[0]}: ...").body[0]


class StubTest(unittest.TestCase):
    def check_function(self, name: str, stub: ast.FunctionDef, function) -> None:
        with self.subTest(name):
            expected = parameters(stub)
            found = parameters(built(function))
            self.assertEqual([p[:2] for p in expected], [p[:2] for p in found])
            for (parameter, _, default), (_, _, real) in zip(expected, found):
                self.assertEqual(default is None, real is None, parameter)
                if default not in (None, "..."):
                    self.assertEqual(default, real, parameter)

    def check_class(self, stub: ast.ClassDef, kind: type) -> None:
        members = {member.name: member for member in stub.body}
        public = {name for name in vars(kind) if not name.startswith("_")}
        self.assertEqual(public, set(members) - COMMON, stub.name)
        for name, member in members.items():
            real = vars(kind).get(name)
            decorators = {decorator.id for decorator in member.decorator_list}
            if name == "__eq__":
                continue
            self.assertEqual("property" in decorators, isinstance(real, property), name)
            if isinstance(real, staticmethod):
                self.assertIn("staticmethod", decorators)
                real = real.__func__
            if not isinstance(real, property):
                self.check_function(f"{stub.name}.{name}", member, real)

    def check_module(self, module) -> None:
        stub = ast.parse((FOLDER / f"{module.__name__.split('.')[-1]}.pyi").read_text())
        told = {}
        for node in stub.body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                told[node.name] = node
        self.assertEqual(set(told), {name for name in vars(module) if not name.startswith("_")})
        for name, node in told.items():
            if isinstance(node, ast.ClassDef):
                self.check_class(node, getattr(module, name))
            else:
                self.check_function(name, node, getattr(module, name))

    def test_core(self):
        self.check_module(nbvopt._core)

    def test_sim(self):
        self.check_module(nbvopt._sim)

    def test_package_exports_all(self):
        names = set()
        for node in ast.parse((FOLDER / "__init__.pyi").read_text()).body:
            if isinstance(node, ast.ImportFrom) and node.module.startswith("nbvopt."):
                names |= {name.asname for name in node.names}
            elif isinstance(node, ast.FunctionDef):
                names.add(node.name)
        self.assertEqual(names, set(nbvopt.__all__))
        self.assertTrue((FOLDER / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
