using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Sets the page of the manual that a component's help button opens, such as <c>programs.md#build</c>. Derived components inherit the page.
    /// </summary>
    [AttributeUsage(AttributeTargets.Class)]
    internal sealed class HelpPageAttribute : HelpURLAttribute
    {
        internal HelpPageAttribute(string page) : base(page)
        {
        }

        /// <summary>The page, relative to the folder of the manual.</summary>
        internal string Page => base.URL;

        /// <inheritdoc/>
        public override string URL => Installation.AddressOf(Page);
    }
}
