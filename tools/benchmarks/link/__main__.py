"""``python3 -m tools.benchmarks.link``."""

from tools.demo.signals import run_command

if __name__ == "__main__":
    run_command("tools.benchmarks.link.command")
