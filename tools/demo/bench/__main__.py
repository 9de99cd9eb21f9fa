"""``python3 -m tools.demo.bench``."""

from tools.demo.signals import run_command

if __name__ == "__main__":
    run_command("tools.demo.bench.command")
