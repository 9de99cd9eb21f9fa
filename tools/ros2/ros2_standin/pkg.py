"""``ros2 pkg list|prefix|executables``."""

from __future__ import annotations

import argparse

from ros2_standin.packages import package_executables, package_names, package_prefix, package_share


def list_arguments(_parser: argparse.ArgumentParser) -> None:
    """``list`` takes none."""


def list_verb(_args: argparse.Namespace) -> None:
    """Print the names of all packages."""
    for name in sorted(package_names()):
        print(name)


def prefix_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``prefix``."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="show share directory for the package")


def prefix_verb(args: argparse.Namespace) -> None:
    """Print where a package is installed."""
    print(package_share(args.package_name) if args.share else package_prefix(args.package_name))


def executables_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``executables``."""
    parser.add_argument("package_name", nargs="?", help="Name of the package to get executables for")
    parser.add_argument("--full-path", action="store_true", help="Show the full path of each executable")


def executables_verb(args: argparse.Namespace) -> None:
    """Print the executables of one package, or of all."""
    names = [args.package_name] if args.package_name else sorted(package_names())
    for name in names:
        for path in package_executables(name):
            print(path if args.full_path else f"{name} {path.name}")
